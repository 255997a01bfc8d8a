"""Quantities that are fitted, and their collections."""
