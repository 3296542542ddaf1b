"""Frequency domain: modes, poles and frequency responses of chains, planar arms and continuous beams."""
