"""The studio: a local web application in which a line is edited and its form is seen at once."""
