"""What turns an estimate into torques: predictive control, LQR, PD."""
