"""A second simulated patient, for judging only: nothing is ever chosen on it.

A skinned triangle mesh on an anatomical skeleton, with skin, cameras and light of its own. It shares no construction
with :mod:`carpus.core.simulation`, and nothing outside ``tests`` knows it.
"""
