"""Meshes a cohort: many scans, one job each, by Snakemake on this machine or on a cluster. `scantet cohort` starts it."""
