"""Trees and forests, represented as bytes. The bytes of a tree without colours and directions are the levels
of its vertices in preorder. The root has level 0.
"""
