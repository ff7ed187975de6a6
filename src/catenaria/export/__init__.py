"""What is found, for others: schedules, drawings, data, and the initial state of dynamics codes."""
