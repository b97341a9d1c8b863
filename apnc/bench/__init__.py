"""What a tick costs, measured side by side in one run."""
