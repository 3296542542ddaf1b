"""What an arm will do, as controllers compute it: samples of the generated step, linear models, modes."""
