"""Grounds: one object each, which nothing else needs to know the kind of."""
