"""Windows by MuJoCo's names: what crosses, the handle, managed windows."""
