"""Finding methods: search, sharpen, prove, recognise closed forms, and show that there are none."""
