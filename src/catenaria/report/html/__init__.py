"""One self-contained HTML page of a result: figures that answer to the pointer, tables, checks, input."""
