"""What foot sensors make of the loads."""
