"""Training items: ray-cast from seeds where the model is trained, or read from shards; batches."""
