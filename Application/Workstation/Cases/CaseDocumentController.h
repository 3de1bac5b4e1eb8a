#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <QObject>
#include <QStringList>
#include <QTimer>

#include "BackgroundWork.h"
#include "ExportDialog.h"
#include "petrous/Presenters/CaseBuilder.h"
#include "petrous/Presenters/SourceContent.h"
#include "petrous/Presenters/WorkstationModel.h"

class QProgressDialog;
class QWidget;

namespace petrous::workstation
{

class Banner;
class CaseSaver;

/// Opens cases, creates them from files, adds files to the open one, and reports errors. Files are
/// read in a separate thread; their kind is determined by their content (presenters::lookAt), and
/// the user is asked if that is ambiguous. Unsaved removal is never discarded without asking.
class CaseDocumentController : public QObject
{
  Q_OBJECT
public:
  /// `window` is the parent of dialogs and owns the banners.
  CaseDocumentController(presenters::WorkstationModel& model, CaseSaver& saver, QWidget& window,
                         Banner& unsaved, Banner& loading, Banner& damaged, Banner& removed);
  ~CaseDocumentController() override;

  /// A case's name; or folders and files: a CT starts a case, anything else is added to it, or to
  /// the open one.
  void open(const QStringList& what);
  void openCase(const std::string& name);
  void openFolder();     ///< with a dialog
  void openRegion();     ///< likewise, and a region of each image is chosen first
  void openFileRegion(); ///< likewise, of a file
  void openFiles();      ///< with a dialog
  /// With a dialog, to the open case. `folder`: of DICOM, or of masks.
  void add(presenters::Content content, bool folder = false);

  /// A structure, a mesh or an MR of the open case.
  void removePart(const std::string& name);
  /// What becomes of bits that nothing explains; nullopt: the user does not know.
  std::optional<imaging::UndeclaredBits> askBits(const std::string& why, bool canKeep);
  void restorePart();                       ///< the one that was removed last
  void renamePart(const std::string& name); ///< with a dialog
  /// Of an MR, a structure's file or a mesh of the open case, with a dialog.
  void correctAxes(const std::string& part);

  /// Any other change of the case's parts, such as an undo: not while parts are being added. Saves
  /// the case. False: it was not done; tells why.
  bool changeParts(const std::function<void()>& change);

  /// For other programs, with a dialog, in which `what` and `part` (presenters::ExportOptions) are
  /// chosen; empty: what was chosen last.
  void exportPart(const QString& what = {}, const QString& part = {});
  void archive();                        ///< the open case to one file, with a dialog
  void archive(const std::string& name); ///< likewise any case of the library
  /// A new case of the open one's primary image with other axes, with a dialog.
  void correctAxes();
  void restore(); ///< the case of an archive, with a dialog

  void makeSample();

  /// Runs a task with a progress dialog that can cancel it, unless another one is running; tells
  /// why it failed.
  void run(const QString& title, BackgroundWork::Work task);

  /// Changes a case of the library, as `run`. The open one is saved and closed first, so that this
  /// window does not write to it, and opened again as `after` (empty: stays closed), or as it was
  /// if that fails. `changed` is called in the end, unless it failed.
  void changeCase(const QString& title, const std::string& name, const std::string& after,
                  std::function<void(library::Library&)> change, std::function<void()> changed);
  /// As `run`, for a task that changes any case or object of the library: the open case is saved
  /// and closed first, and opened again in the end.
  void
  maintain(const QString& title,
           std::function<BackgroundWork::Reply(library::Library&, const core::Progress&)> task);

  void save();  ///< and reports it
  bool saved(); ///< saves what is unsaved and waits; false: that failed, which the banner shows
  void saveAs();
  void closeCase();             ///< saves it first; stays open where that fails
  void prepare();               ///< the slow part of the open case (WorkstationModel::preparation)
  void prepareUnlessUnderWay(); ///< as prepare, after it was stopped or failed

  /// Asks what becomes of what is not part of the case yet; false: the user wants to stay.
  std::function<bool()> mayDropDraft;

  /// Asks what becomes of jobs whose results would change the open case; false: the user wants to
  /// stay, or to wait: `again`, which leaves anew, is called then. Null: waiting is not offered.
  /// `what`: becomes of the case then, for the user: "The case is closed".
  std::function<bool(const std::function<void()>& again, const QString& what)> mayDropJobs;
  /// What is being added to a case or made into one, for such a question; empty: nothing.
  QString changing() const;
  void stopWork(); ///< and waits; a stopped import leaves nothing behind

  /// Cancels imports, saves what is unsaved. Returns false if that failed, which the banner shows:
  /// the window stays open.
  bool mayLeave();

  bool busy() const noexcept { return m_work.busy() || m_held || m_preparation.busy(); }
  /// Or reading: one at a time.
  bool writing() const noexcept { return m_work.busy() || m_held || m_asking; }

signals:
  void statusMessage(const QString& line); ///< for the status bar
  void ready();                            ///< the case's structures are loaded
  void added(bool onlyImages);             ///< parts came to the open case
  void working(const QString& title);      ///< on something with progress; empty: it has ended

private:
  using Sources = std::vector<presenters::SourceContent>;
  /// How files were chosen.
  struct Purpose
  {
    std::optional<presenters::Content> content = {}; ///< as the user says
    bool region = false;                             ///< of each image, to be chosen
  };
  /// A series or a file, and what was asked about it.
  struct Item
  {
    presenters::SourceContent source;
    bool region = false;
    std::optional<core::PatientBox> roi = {};
    std::optional<bool> assumeRas = {};            ///< presenters::CaseSources
    std::optional<double> unit = {};               ///< likewise
    std::optional<core::AxesCorrection> axes = {}; ///< presenters::PartSource
    bool isSeen = true; ///< false: chosen by name, and presenters::lookAt has more to say
  };
  /// The case to which parts come, as it is open now.
  struct Target
  {
    std::uint64_t shownAs = 0; ///< WorkstationModel::shownAs
    QString name;
  };

  void open(const QStringList& what, const Purpose& purpose);
  void restore(const std::filesystem::path& file, const std::string& name);
  void lookAt(const std::vector<std::filesystem::path>& paths, const Purpose& purpose);
  void decide(const Sources& found, const Purpose& purpose);
  void lookAtChosen(std::vector<Item> items, const Purpose& purpose);
  void decide(std::vector<Item> items, const Purpose& purpose);
  bool ask(Item& item, const Purpose& purpose);
  bool chooseSeries(const presenters::SourceContent& source, const Purpose& purpose,
                    std::vector<Item>& items);
  bool askContent(presenters::SourceContent& source);
  bool askMrAlone(const presenters::SourceContent& source);
  bool askRepair(const presenters::SourceContent& source);
  void refuseSeries(const presenters::SourceContent& source);
  bool askRegion(Item& item);
  bool askPlace(Item& item);
  bool askNames(presenters::CaseSources& sources, const std::vector<Item>& others,
                const std::string& newCase);
  void makeCase(const std::string& name,
                std::function<presenters::CaseSources(const core::Progress&)> sources,
                scene::Side side = scene::Side::Unknown);
  enum class Outside
  {
    Added,  ///< as the others, or there are none
    Left,   ///< they are to be left out
    AllLeft ///< and they are all
  };
  Outside askOutside(const std::vector<presenters::StructureReport>& report, const QString& what);
  void addParts(const presenters::PartSources& parts, const QString& what,
                const std::vector<presenters::StructureReport>& earlier = {});
  void tell(const std::vector<presenters::PartFailure>& failures,
            const std::vector<presenters::StructureReport>& report, const Target& target);
  void tellStructures(const std::vector<presenters::StructureReport>& report);
  void refuseAll(const QStringList& whys);
  bool isOpen(const Target& target) const;
  std::optional<presenters::PartSource> askAgain(const presenters::PartFailure& failure,
                                                 const Target& target);
  std::optional<bool> askSide(const std::filesystem::path& path);
  std::optional<double> askUnit(const std::filesystem::path& path, const imaging::UnitDoubt& doubt);
  bool askDrawnOn(presenters::PartSource& source);
  bool askAsTheyLie(const presenters::PartFailure& failure);
  bool askNewNames(presenters::PartSource& source, const std::vector<std::string>& taken,
                   std::size_t others);
  bool askTaken(presenters::PartSources& parts, const std::vector<Item>& others);
  bool askOtherPatient(const presenters::PartFailure& failure, const Target& target);
  std::optional<imaging::MeshSpace> askMeshSpace(const presenters::PartFailure& failure);
  bool adopt(scene::Case value);
  void keepInLibrary(scene::Case value);
  void write(const presenters::ExportOptions& options);
  void offerCtGrid(const presenters::ExportOptions& options, const QString& why);
  /// `changesCase`: what it makes is lost when it is stopped.
  void work(const QString& title, BackgroundWork::Work work, bool changesCase = false);
  void take(const BackgroundWork::Reply& reply);
  void fail(const QString& why);
  void endWork();
  bool closeToReopen(); ///< false if the user stays
  void reopen();
  void connectBanners();
  void watchForDamage();
  void lookForDamage();
  void notSaved(const QString& why);
  void bringBack(); ///< the case, which another program deleted
  bool leaveCase();
  bool mayStopJobs(const std::function<void()>& again = {}, const QString& what = {});
  void refuse(const QString& why);
  void inform(const QString& text);

  presenters::WorkstationModel& m_model;
  CaseSaver& m_saver;
  QWidget& m_window;
  Banner& m_unsaved;
  Banner& m_loading;
  Banner& m_damaged;
  Banner& m_removed;
  BackgroundWork m_work;
  QString m_changing;           // what it changes a case by, while it runs
  BackgroundWork::Reply m_held; // of m_work, until no dialog is open
  QTimer m_heldAgain;
  BackgroundWork m_preparation;
  std::unique_ptr<QProgressDialog> m_progress;     // of m_work
  std::optional<ExportDialog::Choices> m_exported; // what was chosen last
  QString m_damageTold;
  std::string m_reopen; // the case that was closed for maintenance
  bool m_prepareAgain = false;
  bool m_sayWhenSaved = false;
  QString m_whyNamed;    // said in place of the name when it is saved; empty: the name is
  bool m_asking = false; // a modal dialog is open
  bool m_leaving = false;
  bool m_giveUp = false; // the window may close with unsaved changes
};

} // namespace petrous::workstation
