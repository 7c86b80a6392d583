"""How a robot moves: wheels, tracks, rotors, and the plugins that drive them."""
