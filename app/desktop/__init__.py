"""The desktop application: what stands behind the ports of the windows, and which screen follows which."""
