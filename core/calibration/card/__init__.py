"""A printed card with six discs at known places: how far off a camera measures, followed over months."""
