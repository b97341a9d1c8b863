"""Gallery of real robots: read from public model files, tuned, and measured on fresh seeds."""
