"""Code that plans, launches and collects renders; rendered output goes elsewhere."""
