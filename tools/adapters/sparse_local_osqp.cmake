# sparse_local_osqp.cmake: OSQP 1.0 solves its linear systems by sparse_local.h
#
#     cmake -S osqp -B build -DCMAKE_PROJECT_osqp_INCLUDE=.../sparse_local_osqp.cmake
#
# For the built-in algebra. No file of OSQP is changed: sparse_local_osqp.c is compiled into the
# library, and two files of OSQP are compiled so that they call it.

function(sparse_local_osqp)
  if(NOT OSQP_ALGEBRA_BUILTIN OR DEFINED OSQP_EMBEDDED_MODE)
    message(FATAL_ERROR "sparse_local_osqp.cmake needs the built-in algebra, not embedded")
  endif()
  set(here ${CMAKE_CURRENT_FUNCTION_LIST_DIR})
  # sparse_local.h: two folders above, as in the repository, or beside this file
  target_sources(OSQPLIB PRIVATE ${here}/sparse_local_osqp.c)
  set_property(SOURCE ${here}/sparse_local_osqp.c APPEND PROPERTY INCLUDE_DIRECTORIES ${here}/../.. ${here})
  set_property(SOURCE ${PROJECT_SOURCE_DIR}/algebra/builtin/algebra_libs.c APPEND PROPERTY
    COMPILE_DEFINITIONS init_linsys_solver_qdldl=init_linsys_solver_sparse_local)
  set_property(SOURCE ${PROJECT_SOURCE_DIR}/src/osqp_api.c APPEND PROPERTY
    COMPILE_DEFINITIONS codegen_src=codegen_src_sparse_local)
endfunction()

cmake_language(DEFER CALL sparse_local_osqp)
