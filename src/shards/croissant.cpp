// SPDX-FileCopyrightText: 2026 The tofray authors
// SPDX-License-Identifier: Apache-2.0
#include "results/array_table.h"
#include "shards/quantised.h"
#include "shards/summary.h"

namespace tofray::shards {

namespace {

using files::Json;

/// The words of the format, as its specification gives them.
Json context() {
  Json out = Json::object();
  out.set("@language", "en").set("@vocab", "https://schema.org/").set("citeAs", "cr:citeAs").set("column", "cr:column");
  out.set("conformsTo", "dct:conformsTo")
      .set("cr", "http://mlcommons.org/croissant/")
      .set("data", Json::object().set("@id", "cr:data").set("@type", "@json"));
  out.set("dataType", Json::object().set("@id", "cr:dataType").set("@type", "@vocab")).set("dct", "http://purl.org/dc/terms/");
  out.set("extract", "cr:extract").set("field", "cr:field").set("fileProperty", "cr:fileProperty").set("fileObject", "cr:fileObject");
  out.set("fileSet", "cr:fileSet").set("format", "cr:format").set("includes", "cr:includes").set("isLiveDataset", "cr:isLiveDataset");
  out.set("key", "cr:key")
      .set("md5", "cr:md5")
      .set("recordSet", "cr:recordSet")
      .set("references", "cr:references")
      .set("regex", "cr:regex");
  out.set("repeated", "cr:repeated").set("replace", "cr:replace").set("sc", "https://schema.org/").set("separator", "cr:separator");
  out.set("source", "cr:source").set("subField", "cr:subField").set("transform", "cr:transform");
  return out;
}

Json id_of(const std::string& id) { return Json::object().set("@id", id); }

/// Of a member of each sample.
Json field(const std::string& member, const std::string& what, const char* type) {
  Json source = Json::object();
  source.set("fileSet", id_of("members")).set("extract", Json::object().set("fileProperty", "content"));
  source.set("transform", Json::object().set("regex", "^.*\\." + member + "$"));
  Json out = Json::object();
  out.set("@type", "cr:Field").set("@id", "samples/" + member).set("name", "samples/" + member).set("description", what);
  return out.set("dataType", type).set("source", std::move(source));
}

}  // namespace

std::string croissant_text(const Summary& of, const std::string& sums) {
  Json out = Json::object();
  out.set("@context", context())
      .set("@type", "sc:Dataset")
      .set("conformsTo", "http://mlcommons.org/croissant/1.0")
      .set("name", of.set.name);
  out.set("description", "Simulated raw and depth frames of time-of-flight cameras with ground truth, made by tofray " + of.plan.version +
                             "; card.md says how.");
  out.set("license", of.set.license).set("version", of.plan.id.substr(0, 12)).set("isLiveDataset", false);
  Json distribution = Json::array();
  Json all = Json::object();
  all.set("@type", "cr:FileObject").set("@id", "SHA256SUMS").set("name", "SHA256SUMS").set("contentUrl", "SHA256SUMS");
  distribution.push(all.set("description", "SHA-256 of every shard and record").set("encodingFormat", "text/plain").set("sha256", sums));
  Json shards = Json::object();
  shards.set("@type", "cr:FileSet")
      .set("@id", "shards")
      .set("name", "shards")
      .set("description", "tars of samples; members of one begin with its number");
  distribution.push(shards.set("encodingFormat", "application/x-tar").set("includes", "shards/*/*.tar"));
  Json members = Json::object();
  members.set("@type", "cr:FileSet").set("@id", "members").set("name", "members").set("description", "files within the shards");
  members.set("containedIn", id_of("shards")).set("encodingFormat", "application/octet-stream");
  distribution.push(members.set("includes", "*"));
  out.set("distribution", std::move(distribution));
  Json fields = Json::array();
  for (const std::string& name : of.plan.arrays) {
    const results::ArrayRow& row = *results::find_array(name);
    fields.push(field(name + ".npy", row.what + " [" + row.unit + "], " + stored_type(of.set, row) + " " + row.shape, "sc:Text"));
  }
  fields.push(field("json", "frequencies, phases and exposures, camera, objects, what was drawn, and the scene", "sc:Text"));
  Json records = Json::object();
  records.set("@type", "cr:RecordSet").set("@id", "samples").set("name", "samples").set("description", "one for each view of each scene");
  out.set("recordSet", Json::array().push(records.set("field", std::move(fields))));
  return files::json_text(out, 2) + "\n";
}

}  // namespace tofray::shards
