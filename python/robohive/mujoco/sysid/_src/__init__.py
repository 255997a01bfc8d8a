"""Modules by the paths at which MuJoCo has them."""
