"""Kills, damaged files and failing servers, few times with every change; ``make torture`` repeats each many times."""
