"""From images to a bundle: what the model predicts becomes an object that simulators load."""
