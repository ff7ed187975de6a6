"""Form-finding of railway overhead contact lines."""

__version__ = "0.1.0"
