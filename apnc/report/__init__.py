"""Reports: one HTML file with plots that is readable offline, and the folder of a run."""
