# sparse_local-config.cmake: find_package(sparse_local): sparse_local::sparse_local, the header, and
# sparse_local::compiled, the library
if(NOT TARGET sparse_local::sparse_local)
  include("${CMAKE_CURRENT_LIST_DIR}/sparse_local-targets.cmake")
endif()
