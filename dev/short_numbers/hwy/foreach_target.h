// Highway's stand-in is one instruction set: the kernel's source is compiled once.
