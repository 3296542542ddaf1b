"""What acts on an arm over time: tables, profiles, constants."""
