"""The multibody model in Exudyn: tree, servos, contact, and the plant made of them."""
