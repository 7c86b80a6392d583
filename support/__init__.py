"""What tests and benches both use: servers, browsers, real packages and judged findings."""
