"""Everything with an axis: one set of marks, drawn by pyqtgraph's scene in the window and by a painter on paper."""
