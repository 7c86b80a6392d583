"""BRD: breadcrumbs, the communication relays that a robot drops."""
