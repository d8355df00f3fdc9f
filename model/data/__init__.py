"""Training items: from seeds, ray-cast where they are trained on, or from shards; batches of them."""
