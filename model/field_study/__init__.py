"""`artgen study render-field`: what accuracy of rendered fields and extracted meshes costs."""
