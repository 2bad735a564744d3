"""The lesson features: what makes two places alike, and what that is good for."""
