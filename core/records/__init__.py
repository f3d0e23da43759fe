"""What people type: one relational store, SQLite in the data folder, PostgreSQL where a clinic has it."""
