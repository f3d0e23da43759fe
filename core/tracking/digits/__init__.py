"""The digits: their model, their markers' association, what is read of their depth."""
