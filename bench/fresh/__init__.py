"""How the checker answers at first contact with robots that nobody here has seen."""
