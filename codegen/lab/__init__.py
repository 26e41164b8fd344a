"""The lab: emitted integrators are measured here, against references computed by methods of another kind."""
