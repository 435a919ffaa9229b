"""The pattern: quads in two colours, spanning trees, the one curve and its certificate."""
