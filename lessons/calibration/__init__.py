"""The lesson on calibration."""
