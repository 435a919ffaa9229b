"""Many runs: workers that make one folder per config."""
