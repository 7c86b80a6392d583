"""Code for tests and benches: servers, browsers, real packages and judged findings."""
