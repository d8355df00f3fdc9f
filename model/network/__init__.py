"""The network: tokens of images and parts, the trunk, what a slot's vector means."""
