"""Models, simulations and their options: structs whose arrays are numpy arrays."""
