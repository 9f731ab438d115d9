# What portability.py --hostile includes: a parent project that asks for the same options once more, for all that is below.
separate_arguments(hostile UNIX_COMMAND "${CMAKE_CXX_FLAGS}")
add_compile_options(${hostile})
add_link_options(${hostile})
