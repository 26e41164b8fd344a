# 2: the scene raises SystemExit: 3
raise SystemExit(3)
