"""The screen while measuring, readable from 1.5 m."""
