"""Chains of .prm files, see run_chain.py."""

import os
import sys

# For ranks.py and program_choice.py; the module as a whole needs h5py.
sys.path.append(os.path.normpath(os.path.join(os.path.dirname(os.path.abspath(__file__)), os.pardir, "python", "mesoslip")))
