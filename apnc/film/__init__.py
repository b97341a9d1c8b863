"""A walk as a film, drawn without a browser."""
