#include "window/gui/ParametersDialog.h"

#include <wx/display.h>
#include <wx/propgrid/props.h>
#include <wx/sizer.h>
#include <wx/tokenzr.h>

#include <algorithm>

#include "base/Numbers.h"
#include "window/gui/WhatIsThis.h"

namespace hybrid_slam::window {
namespace {

wxSize startSize(const wxWindow* parent) {
  wxSize size = parent->FromDIP(wxSize(640, 600));
  size.DecTo(wxDisplay(0u).GetClientArea().GetSize() - parent->FromDIP(wxSize(20, 50)));
  return size;
}

/// Splits "a | b | c"; empty for other ranges.
wxArrayString choicesOf(const Option& option) {
  wxArrayString choices;
  if (option.range == "true or false") {
    choices.Add("true");
    choices.Add("false");
  }
  if (option.range.find(" | ") == std::string::npos) return choices;
  size_t at = 0;
  while (at != std::string::npos) {
    const size_t end = option.range.find(" | ", at);
    choices.Add(option.range.substr(at, end == std::string::npos ? end : end - at));
    at = end == std::string::npos ? end : end + 3;
  }
  return choices;
}

wxPGProperty* propertyOf(const std::string& section, const Option& option) {
  const wxString label = option.unit.empty() ? option.key : option.key + " (" + option.unit + ")";
  const wxString name = section + "." + option.key;
  const wxArrayString choices = choicesOf(option);
  wxPGProperty* property = nullptr;
  if (choices.empty()) {
    property = new wxStringProperty(label, name, option.get());
  } else {
    property = new wxEnumProperty(label, name, choices, {}, choices.Index(option.get()));
  }
  property->SetHelpString(option.why + " [" + option.range + "]");
  return property;
}

std::string faultOf(Options& options, const std::string& section, const std::string& key,
                    const std::string& value) {
  for (const Option& option : options.table())
    if (option.key == key) {
      const std::string expected = option.set(value);
      return expected.empty() ? ""
                              : "`" + value + "`: section [" + section + "], key `" + key + "`; " + expected;
    }
  return "unknown key: section [" + section + "], key `" + key + "`";
}

}  // namespace

std::string ParametersDialog::fault(const Settings& settings, const std::string& section,
                                    const std::string& key, const std::string& value) {
  const auto trial = settings.copy();
  for (const auto& [name, options] : trial->configuration.sections())
    if (name == section) return faultOf(*options, section, key, value);
  return "unknown section [" + section + "]";
}

ParametersDialog::ParametersDialog(wxWindow* parent, const Settings& settings)
    : wxDialog(parent, wxID_ANY, "Parameters", wxDefaultPosition, startSize(parent),
               wxDEFAULT_DIALOG_STYLE | wxRESIZE_BORDER),
      settings_(settings.copy()) {
  grid_ = new wxPropertyGrid(this, wxID_ANY, wxDefaultPosition, wxDefaultSize,
                             wxPG_SPLITTER_AUTO_CENTER | wxPG_BOLD_MODIFIED);
  grid_->SetExtraStyle(wxPG_EX_HELP_AS_TOOLTIPS);
  addControls();
  addSections();
  grid_->Bind(wxEVT_PG_CHANGING, &ParametersDialog::onChanging, this);
  grid_->Bind(wxEVT_PG_CHANGED, &ParametersDialog::onChanged, this);
  grid_->Bind(wxEVT_PG_SELECTED, [this](wxPropertyGridEvent&) { showHelp(); });
  search_->Bind(wxEVT_TEXT, [this](wxCommandEvent&) { showMatches(); });
  reset_->Bind(wxEVT_BUTTON, [this](wxCommandEvent&) { reset(grid_->GetSelection()); });
  resetAll_->Bind(wxEVT_BUTTON, [this](wxCommandEvent&) { resetAll(); });
  showHelp();
  search_->SetFocus();
}

void ParametersDialog::addSections() {
  const auto defaults = settings_->defaults();
  for (const auto& [section, options] : defaults->configuration.sections())
    for (const Option& option : options->table()) defaults_[section + "." + option.key] = option.get();
  for (const auto& [section, options] : settings_->configuration.sections()) {
    sections_.push_back({grid_->Append(new wxPropertyCategory("[" + section + "]")), {}});
    for (const Option& option : options->table()) {
      sections_.back().keys.push_back(grid_->Append(propertyOf(section, option)));
      mark(sections_.back().keys.back());
    }
  }
}

void ParametersDialog::addControls() {
  search_ = new wxSearchCtrl(this, wxID_ANY);
  search_->ShowCancelButton(true);
  search_->MoveBeforeInTabOrder(grid_);
  explain(search_, "Shows the keys that have these words in their section, name or description");
  help_ =
      new wxStaticText(this, wxID_ANY, "", wxDefaultPosition, FromDIP(wxSize(-1, 56)), wxST_NO_AUTORESIZE);
  reset_ = new wxButton(this, wxID_ANY, "Reset to &default");
  resetAll_ = new wxButton(this, wxID_ANY, "Reset &all");
  explainWithTip(reset_, "Gives the selected key its default");
  explainWithTip(resetAll_, "Gives every key its default; the log stays open");
  auto* const row = new wxBoxSizer(wxHORIZONTAL);
  row->Add(reset_, wxSizerFlags().Border(wxRIGHT, FromDIP(6)));
  row->Add(resetAll_);
  row->AddStretchSpacer();
  row->Add(CreateStdDialogButtonSizer(wxOK | wxCANCEL));
  auto* const top = new wxBoxSizer(wxHORIZONTAL);
  top->Add(new wxStaticText(this, wxID_ANY, "Search"), wxSizerFlags().CentreVertical());
  top->Add(search_, wxSizerFlags(1).Border(wxLEFT, FromDIP(6)));
  auto* const column = new wxBoxSizer(wxVERTICAL);
  const auto flags = [this](int share) { return wxSizerFlags(share).Expand().Border(wxALL, FromDIP(6)); };
  column->Add(top, flags(0));
  column->Add(grid_, flags(1));
  column->Add(help_, flags(0));
  column->Add(row, flags(0));
  SetSizer(column);
}

/// Shows the keys of each section that contain all the words.
void ParametersDialog::showMatches() {
  grid_->ClearSelection(true);
  const wxArrayString words = wxStringTokenize(search_->GetValue().Lower());
  for (const Section& section : sections_) {
    std::vector<wxPGProperty*> found;
    for (wxPGProperty* const key : section.keys) {
      const wxString text = (key->GetName() + " " + key->GetHelpString()).Lower();
      if (std::all_of(words.begin(), words.end(), [&](const wxString& word) { return text.Contains(word); }))
        found.push_back(key);
    }
    section.category->Hide(true);  // with its keys
    section.category->Hide(found.empty(), wxPG_DONT_RECURSE);
    for (wxPGProperty* const key : found) key->Hide(false);
  }
  grid_->Refresh();
  showHelp();
}

/// Shows the help of the selected key.
void ParametersDialog::showHelp() {
  const wxPGProperty* const key = grid_->GetSelection();
  const bool isKey = key && !key->IsCategory();
  reset_->Enable(isKey && !isDefault(key));
  const auto all = [this](const Section& section) {
    return std::all_of(section.keys.begin(), section.keys.end(), [this](auto* k) { return isDefault(k); });
  };
  resetAll_->Enable(!std::all_of(sections_.begin(), sections_.end(), all));
  help_->SetLabel("Values are checked as they are entered. Bold: not the default.");
  if (!isKey) return;
  const auto standard = wxString::FromUTF8(defaults_.at(key->GetName().utf8_string()));
  help_->SetLabel(key->GetHelpString() + "\nDefault: " + (standard.empty() ? wxString("none") : standard));
  help_->Wrap(help_->GetClientSize().x);
}

void ParametersDialog::reset(wxPGProperty* key) {
  if (!key || key->IsCategory()) return;
  const std::string name = key->GetName().utf8_string();
  grid_->SetPropertyValueString(key, wxString::FromUTF8(defaults_.at(name)));
  changes_.erase(std::remove_if(changes_.begin(), changes_.end(),
                                [&](const std::string& change) { return change.rfind(name + "=", 0) == 0; }),
                 changes_.end());
  if (name != "run.rawlog") resets_.insert(name);  // it stays open
  mark(key);
  showHelp();
}

void ParametersDialog::resetAll() {
  grid_->ClearSelection(true);
  for (const Section& section : sections_)
    for (wxPGProperty* const key : section.keys) reset(key);
}

bool ParametersDialog::isDefault(const wxPGProperty* key) const {
  const std::string value = key->GetValueAsString().utf8_string();
  const std::string standard = defaults_.at(key->GetName().utf8_string());
  const auto number = parseNumber(value), other = parseNumber(standard);
  return value == standard || (number && other && *number == *other);
}

/// Shows a changed key in bold, which the grid itself uses for any edited key.
void ParametersDialog::mark(wxPGProperty* key) {
  key->SetModifiedStatus(!isDefault(key));
  grid_->RefreshProperty(key);
}

void ParametersDialog::onChanging(wxPropertyGridEvent& event) {
  const wxPGProperty* const property = event.GetProperty();
  wxVariant entered = event.GetValue();
  const std::string value = property->ValueToString(entered).utf8_string();
  const std::string name = property->GetName().utf8_string();
  const size_t dot = name.find('.');
  const std::string wrong = fault(*settings_, name.substr(0, dot), name.substr(dot + 1), value);
  if (wrong.empty()) return;
  event.SetValidationFailureBehavior(wxPG_VFB_SHOW_MESSAGEBOX | wxPG_VFB_STAY_IN_PROPERTY);
  event.SetValidationFailureMessage(wrong);
  event.Veto();
}

void ParametersDialog::onChanged(wxPropertyGridEvent& event) {
  wxPGProperty* const key = event.GetProperty();
  changes_.push_back((key->GetName() + "=" + key->GetValueAsString()).utf8_string());
  mark(key);
  showHelp();
}

}  // namespace hybrid_slam::window
