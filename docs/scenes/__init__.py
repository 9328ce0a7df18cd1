"""The example scenes, packaged as `chapsym.scene.examples`: `chapsym scene new` writes them."""
