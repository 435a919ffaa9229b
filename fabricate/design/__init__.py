"""The curve chosen: which of all single curves is drawn, and what decides it."""
