"""Enumerations with the numbers of MuJoCo 3.12."""
