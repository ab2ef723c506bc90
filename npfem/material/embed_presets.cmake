# The material files as strings in a C++ source, so that the library needs no data folder.
#
# Included, it sets NPFEM_PRESETS_CPP, the source to compile.
# Run as a script (cmake -DOUTPUT=... -DFILES=... -P), it writes that source.
if(CMAKE_SCRIPT_MODE_FILE)
  set(source "// Written by embed_presets.cmake from materials/*.toml.\n#include \"material/presets.h\"\n\nnamespace npfem {\n\n")
  set(rows "")
  foreach(file IN LISTS FILES)
    get_filename_component(name "${file}" NAME_WLE)
    file(READ "${file}" content)
    string(APPEND rows "    {\"${name}\", R\"toml(${content})toml\"},\n")
  endforeach()
  string(APPEND source "std::span<const PresetText> preset_texts() {\n  static constexpr PresetText texts[] = {\n${rows}  };\n"
                       "  return texts;\n}\n\n}  // namespace npfem\n")
  file(WRITE "${OUTPUT}" "${source}")
  return()
endif()

set(preset_files "")
foreach(name rbc rbc-viscous platelet palabos-rbc palabos-platelet)
  list(APPEND preset_files "${CMAKE_CURRENT_LIST_DIR}/../../materials/${name}.toml")
endforeach()
set(NPFEM_PRESETS_CPP "${CMAKE_CURRENT_BINARY_DIR}/presets.cpp")
add_custom_command(OUTPUT "${NPFEM_PRESETS_CPP}" DEPENDS ${preset_files} "${CMAKE_CURRENT_LIST_FILE}" VERBATIM
  COMMENT "Embedding the materials"
  COMMAND "${CMAKE_COMMAND}" "-DOUTPUT=${NPFEM_PRESETS_CPP}" "-DFILES=${preset_files}" -P "${CMAKE_CURRENT_LIST_FILE}")
