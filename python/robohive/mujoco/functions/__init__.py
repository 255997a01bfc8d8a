"""Functions with the names, arguments and results of MuJoCo's."""
