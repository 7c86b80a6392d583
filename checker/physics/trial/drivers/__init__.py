"""Ways of moving: each file makes the plan of a trial for one of them."""
