# 6: xs[0] = 1 and xs[1] = 0; expected increasing numbers in xs
from codegen.groups import LeftMultiplication, Rn
from codegen.scene import FieldScene, table

y = Rn(1).point("y")
f = table([1, 0], [0, 1], y[0])
scene = FieldScene(group=Rn(1), action=LeftMultiplication(), y=y, f=[f], y0=[1], span=(0, 1))
