"""Readable reference of the adaptive neural controller of Sun, Dai & Manoonpong (2023).

One module per block of the paper; ``variables`` is the table that every interface is made from.
"""

__version__ = "0.1.0"
