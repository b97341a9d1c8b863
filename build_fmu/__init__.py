"""From the table of variables and the C sources to an FMU file."""
