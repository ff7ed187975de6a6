"""What an engineer is handed: tables and figures of a result."""
