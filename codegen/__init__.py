"""The compiler: a scene and a method become a step program, and that becomes Python or C."""
