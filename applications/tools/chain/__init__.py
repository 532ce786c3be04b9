"""Chains of .prm files, see run_chain.py."""
