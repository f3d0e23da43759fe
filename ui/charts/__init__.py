"""Charts: drawn by pyqtgraph's scene in the window, and by a painter on paper."""
