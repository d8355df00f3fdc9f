"""What each effect of light transport shows and costs: small scenes that call for one each."""
