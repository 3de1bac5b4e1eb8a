#include <optional>

#include "CaseJson.h"
#include "Commands.h"
#include "MaskOptions.h"
#include "Numbers.h"
#include "petrous/Library/Archive.h"
#include "petrous/Presenters/CaseTransfer.h"
#include "petrous/Presenters/LeavingImages.h"

namespace petrous::cli
{

namespace
{

struct ArchiveCommandOptions
{
  std::string caseName, file;
  std::vector<std::string> withoutMrs;
  std::optional<int> level;
  bool planOnly = false, keepIdentity = false, withoutNotes = false, withVideos = false,
       withDocuments = false;
  bool dryRun = false;
  MaskOptions mask;
};

struct RestoreCommandOptions
{
  std::string file, name, ct;
};

std::string megabytes(std::uintmax_t bytes)
{
  return fixed(1e-6 * static_cast<double>(bytes), 1) + " MB";
}

void archive(const Context& context, const ArchiveCommandOptions& options)
{
  const scene::ImageMask mask = options.mask.mask();
  if ((mask.any() || !options.withoutMrs.empty()) && options.planOnly)
    throw UsageError("archive: a plan has no images; give --plan-only, or --mask-face, --roi and "
                     "--without-mr");
  context.refuseOverwriting({options.file});
  const library::Library library = context.openLibrary();
  const library::ArchiveOptions how{options.planOnly,
                                    options.level,
                                    options.withoutNotes,
                                    options.keepIdentity,
                                    options.withVideos,
                                    options.withDocuments,
                                    presenters::maskForArchive(library, mask, options.withoutMrs)};
  scene::Case leaving = library.open(options.caseName);
  presenters::leaveOutMrs(leaving, options.withoutMrs);
  const presenters::IdentityReport report =
      presenters::identityReport(leaving, how, mask, &library);
  if (options.dryRun)
    return printIdentityReport(context, report);
  for (const std::string& warning : report.warnings) // before anything is written
    context.warn(warning);
  for (const std::string& names : report.counted)
    context.warn("  " + names);
  const library::ArchiveSummary done =
      library::archiveCase(library, options.caseName, options.file, how, context.progress());
  for (const std::string& note : done.notes)
    context.warn(note);
  if (!done.durable)
    context.warn(options.file + ": is written, but the disk reported an error; check the disk");
  context.print((done.planOnly ? "the plan of case '" : "case '") + done.name + "' is in " +
                options.file + ": " + std::to_string(done.parts) +
                (done.parts == 1 ? " part, " : " parts, ") + megabytes(done.archiveBytes) +
                " for " + megabytes(done.inputBytes));
  context.printJson({{"case", done.name},
                     {"file", options.file},
                     {"parts", done.parts},
                     {"input_bytes", done.inputBytes},
                     {"bytes", done.archiveBytes},
                     {"plan_only", done.planOnly},
                     {"notes", done.notes}});
}

void restore(const Context& context, const RestoreCommandOptions& options)
{
  library::Library library = context.openLibrary();
  const library::RestoreSummary done =
      library::restoreCase(library, options.file, {options.name, options.ct}, context.progress());
  for (const std::string& note : done.notes)
    context.warn(note);
  context.print("case '" + done.name + "' is restored: " + std::to_string(done.parts) +
                (done.parts == 1 ? " part, " : " parts, ") + std::to_string(done.newParts) +
                " of them new to the library");
  context.printJson({{"case", done.name},
                     {"parts", done.parts},
                     {"new_parts", done.newParts},
                     {"plan_only", done.planOnly},
                     {"notes", done.notes}});
}

} // namespace

void addArchiveCommands(CLI::App& app, Context& context)
{
  auto out = std::make_shared<ArchiveCommandOptions>();
  CLI::App* command = context.addCommand(app, "archive", "Write a case to one file, to hand it on",
                                         [out, &context] { archive(context, *out); });
  command->add_option("CASE", out->caseName, "Name of the case")->required();
  command->add_option("FILE", out->file, "The archive, NAME.petrous")->required();
  command->add_flag("--plan-only", out->planOnly,
                    "Strokes, views and appearance without voxels; restored where the same CT is");
  command->add_flag("--keep-identity", out->keepIdentity,
                    "Keep what may identify the patient: the dates of the planned operation and of "
                    "attachments, the times of strokes, and who signed registrations and when");
  command->add_flag("--without-notes", out->withoutNotes,
                    "Leave out the note of the description, which else goes along as it is");
  command->add_flag("--with-videos", out->withVideos,
                    "Take attached videos along, which else stay: they may show or name the "
                    "patient");
  command->add_flag("--with-documents", out->withDocuments,
                    "Take attached PDFs along, which else stay: they may name the patient, also in "
                    "their metadata, which is not removed");
  addMaskOptions(*command, out->mask);
  command
      ->add_option("--without-mr", out->withoutMrs,
                   "Leave out an MR, as one whose face cannot be masked; repeatable")
      ->type_name("MRNAME");
  command->add_flag("--dry-run", out->dryRun,
                    "Only say what of the case would be in the file, and what may identify the "
                    "patient; nothing is written");
  command
      ->add_option(
          "--level", out->level,
          "Compression of images, 1 (fast) to 12 (small); default: as fast as makes each, "
          "by samples of it, no larger than gzip -6 does, between 1 and 7 (the smallest if "
          "none does)")
      ->check(CLI::Range(1, 12));

  auto in = std::make_shared<RestoreCommandOptions>();
  command = context.addCommand(app, "restore", "Add the case of an archive to the library",
                               [in, &context] { restore(context, *in); });
  command->add_option("FILE", in->file, "The archive")->required();
  command->add_option("--as", in->name, "Name of the new case, instead of that of the archive");
  command->add_option("--ct", in->ct, "For an archive of a plan: a case with the very same CT")
      ->type_name("CASE");
}

} // namespace petrous::cli
