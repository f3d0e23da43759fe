"""Values measured by hand: form and chart."""
