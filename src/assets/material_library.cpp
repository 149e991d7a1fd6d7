// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "assets/material_library.h"

#include <algorithm>

#include "base/constants.h"
#include "base/units.h"
#include "model/tables.h"

namespace tofray::assets {

namespace {

// Sources. Where two values of a wavelength grid lie about 850 nm, their mean is taken.
const std::string nist =
    "Cooksey, Allen, Tsai 2017: Reference data set of human skin reflectance, J. Res. NIST 122, 26, doi:10.6028/jres.122.026";
const std::string usgs = "Kokaly et al. 2017: USGS spectral library version 7, Data Series 1035, doi:10.3133/ds1035, sample ";
const std::string ecostress =
    "ECOSTRESS spectral library 1.0 (Meerdink et al. 2019, Remote Sens. Environ. 230, 111196; courtesy of JPL, Caltech), sample ";
const std::string tamu =
    "Marshall et al. 2014: Characterization of the reflectivity of various black materials (Texas A&M), total reflectance";
const std::string sick = "SICK LD-LRS operating instructions, table of typical remissions; the wavelength is not stated";
const std::string astm = "ASTM D4956-01, least coefficients of retroreflection of white sheets, in visible light; ";

LibraryMaterial matt(const char* name, double reflectivity, const char* what, const std::string& source) {
  return {{name, Material::Brdf::lambert, reflectivity}, what, source};
}
LibraryMaterial target(const char* name, double reflectivity) {
  return matt(name, reflectivity, "a calibrated diffuse target", "by definition: its certificate says how near it comes");
}
/// The lobe through what a sheet sends back 0.2° and 0.5° away from the light: R_A = k_r/(πw²)/(1 + |l − v|²/w²)².
LibraryMaterial sheet(const char* name, double retro, double spread_deg, const char* what, const char* values) {
  Material one{name, Material::Brdf::retro, 0.3};
  one.retro = retro, one.spread_rad = spread_deg * base::pi / 180;
  return {one, what, astm + values + "; k_r and spread fitted to them, the diffuse 0.3 assumed"};
}
LibraryMaterial anodised() {
  Material one{"aluminium-black-anodised", Material::Brdf::ggx, 0.02, 0.5};
  one.alpha = 0.31;
  return {one, "perpendicularly 1.1 to 1.5 times as bright as a white card, as the source says; F_0 and the ground are assumed", sick};
}

std::vector<LibraryMaterial> all() {
  std::vector<LibraryMaterial> out = {
      anodised(),
      matt("aluminium-weathered", 0.538, "bare, scratched, mirror reflection included (940 nm: 0.628)", ecostress + "0384UUUALM"),
      matt("asphalt", 0.110, "a weathered road (940 nm: 0.117)", ecostress + "0095UUUASP"),
      matt("asphalt-rough", 0.269, "black asphaltic concrete (940 nm: 0.284)", ecostress + "0425UUUASP"),
      matt("brick", 0.273, "smooth, red (940 nm: 0.288)", ecostress + "0097UUUBRK"),
      matt("cardboard-grey", 0.20, "relative to diffuse white", sick),
      matt("concrete", 0.360, "grey paving, slightly soiled (940 nm: 0.368)", ecostress + "0424UUUCNC"),
      matt("cotton-white", 0.80, "like white paper", "an estimate: no measurement was at hand"),
      matt("felt-black", 0.022, "cloth", tamu),
      matt("grass", 0.497, "rye sod, seen at 60° (940 nm: 0.507)", ecostress + "grass"),
      matt("grass-dry", 0.566, "seen at 60° (940 nm: 0.618)", ecostress + "dry grass"),
      matt("leaves", 0.549, "a pile of deciduous leaves (940 nm: 0.548)", ecostress + "deciduous"),
      matt("paint-black", 0.037, "gloss alkyd on aluminium, mirror reflection included (940 nm: 0.038)", ecostress + "0402UUUPNT"),
      matt("paper", 0.80, "matt, white, relative to diffuse white", sick),
      matt("paper-black", 0.772, "black construction paper: its dye is none in the near infrared", tamu),
      matt("plastic-black", 0.064, "PET (940 nm: 0.063)", usgs + "GDS382"),
      matt("plywood", 0.788, "pine, fresh (940 nm: 0.821)", usgs + "GDS365"),
      matt("pvc-white", 0.705, "(940 nm: 0.690)", usgs + "GDS338"),
      sheet("retro-sheet", 0.0916, 0.351, "a road sign's white sheet, type III", "0.2°: 250, 0.5°: 95 cd/(lx m²)"),
      sheet("retro-sheet-simple", 0.0296, 0.385, "a road sign's white sheet, type I", "0.2°: 70, 0.5°: 30 cd/(lx m²)"),
      matt("rubber", 0.064, "black roofing, weathered (940 nm: 0.065)", ecostress + "0833UUURBR"),
      matt("rubber-tyre", 0.02, "black, relative to diffuse white", sick),
      matt("skin", 0.603, "mean of the forearms of 100 people, 5 to 95 %: 0.542 to 0.651 (940 nm: 0.532)", nist),
      matt("snow", 0.765, "melting (940 nm: 0.679)", usgs + "mSnw01a"),
      matt("soil", 0.312, "dark reddish-brown loam (940 nm: 0.354)", ecostress + "87P4264"),
      matt("steel-galvanised", 0.186, "fully oxidised (940 nm: 0.162)", ecostress + "0526UUUSTLa"),
      target("target-10", 0.10),
      target("target-18", 0.18),
      target("target-50", 0.50),
      target("target-94", 0.94),
      matt("wood", 0.634, "pine, new (940 nm: 0.668)", usgs + "GDS363"),
  };
  return out;
}

}  // namespace

const std::vector<LibraryMaterial>& material_library() {
  static const std::vector<LibraryMaterial> library = all();
  return library;
}

const LibraryMaterial* find_library_material(const std::string& name) {
  const auto& library = material_library();
  const auto found = std::find_if(library.begin(), library.end(), [&](const LibraryMaterial& one) { return one.material.name == name; });
  return found == library.end() ? nullptr : &*found;
}

std::string numbers_of(const Material& material) {
  std::string brdf, numbers;
  for (const model::Row& row : model::table_of<Material>().rows) {
    if (!model::applies(row, &material)) continue;
    const model::Slot slot = model::slot_of(row, &material);
    if (const auto* choice = std::get_if<model::ChoiceSlot>(&slot))
      brdf = row.form.names.at(static_cast<std::size_t>(choice->get(choice->at)));
    if (double* const* number = std::get_if<double*>(&slot))
      numbers += ", " + row.key + " " + base::quantity_text(**number, row.form.example);
  }
  return brdf + numbers;
}

std::string material_page() {
  std::string text =
      "<!-- SPDX-FileCopyrightText: 2026 The tofray authors -->\n"
      "<!-- SPDX-License-Identifier: Apache-2.0 -->\n"
      "# Materials that need no description\n\n"
      "Written by `tofray list materials`. A scene names them: `material: skin`; a material of the scene's own with the same name comes\n"
      "first. Numbers are those of 850 nm, where they were measured there; what people see says little about them. One sample stands for\n"
      "many: other skins, woods and roads differ by a tenth and more. Lambertian where nothing better is known, though few surfaces "
      "are.\n\n"
      "| name | material | what was measured | source |\n|---|---|---|---|\n";
  for (const LibraryMaterial& one : material_library())
    text += "| `" + one.material.name + "` | " + numbers_of(one.material) + " | " + one.what + " | " + one.source + " |\n";
  return text;
}

}  // namespace tofray::assets
