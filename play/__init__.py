"""The page to play with: controller and robot as WebAssembly in one HTML file."""
