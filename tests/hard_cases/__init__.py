"""Cases that break simulators: each holds to a derived bound, or is refused with a finding."""
