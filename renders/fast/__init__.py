"""The fast backend: pictures by a software rasterizer on albedo and image-based light."""
