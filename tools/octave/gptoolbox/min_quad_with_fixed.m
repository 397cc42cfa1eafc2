function [Z, F, Lambda, Lambda_known] = min_quad_with_fixed(A, B, known, Y, Aeq, Beq, F)
%MIN_QUAD_WITH_FIXED  Minimizes Z' * A * Z + Z' * B with Z(known, :) = Y and Aeq * Z = Beq.
%
%   Z = min_quad_with_fixed(A, B, known, Y)
%   Z = min_quad_with_fixed(A, B, known, Y, Aeq, Beq)
%   [Z, F] = ...              F: what can be used again
%   Z = min_quad_with_fixed(A, B, known, Y, Aeq, Beq, F)   only B, Y and Beq are read, and known
%   [Z, F, Lambda, Lambda_known] = ...   also the Lagrange multipliers of Aeq and of Y
%
%   Takes the place of gptoolbox's function of this name, with its arguments, if this folder comes
%   before it on the path. B, Y and Beq have one column, or one for each column of Z; [] is zero.
%   A and Aeq are sparse or full. The factor is a sparse_local.
%
%   Equalities that follow from others are left out: their multipliers are 0, and a warning says
%   where Beq contradicts them. Where A is semidefinite and singular, as the Laplacian of a closed
%   mesh without known values, Z is 0 in one row of each component, and a B for which there is no
%   minimum is an error. Other singular systems are errors.
%
%   Where Aeq is empty and b and x are wanted in few rows only, F.factor and F.unknown give local
%   solves: F.factor.local(I, b, J) in the numbering of A(F.unknown, F.unknown).
%
%   See also sparse_local.

    if nargin < 5, Aeq = []; end
    if nargin < 6, Beq = []; end
    if nargin < 7 || isempty(F), F = prepare(A, known, Aeq); end
    u = F.unknown;
    if isempty(Y), Y = zeros(numel(F.known), 1); end
    if isempty(B), B = zeros(F.n, 1); end
    if isempty(Beq), Beq = zeros(numel(F.blank), 1); end
    columns = max([size(Y, 2), size(B, 2), size(Beq, 2)]);
    Y = spread(Y, columns);
    B = spread(B, columns);
    Beq = spread(Beq, columns);
    if any(F.blank)
        gap = F.Aeq_blank * Y - Beq(F.blank, :);
        if any(abs(gap(:)) > 1e-10 * max(abs(Y(:))))
            error('min_quad_with_fixed:blank', 'an equality among known values does not hold');
        end
        Beq = Beq(~F.blank, :);
    end
    Beq_all = Beq;
    Beq = Beq(F.kept, :);
    right = [-0.5 * B(u, :); Beq] - F.coupling * Y;
    try
        if F.equalities > 0
            x = F.factor.refine(F.matrix, right);
        else
            x = F.factor.solve(right);
        end
    catch e
        if ~strcmp(e.identifier, 'sparse_local:inconsistent'), rethrow(e); end
        error(e.identifier, 'A is singular and B has a part along a null vector: no minimum');
    end
    Z = zeros(F.n, columns);
    Z(F.known, :) = Y;
    Z(u, :) = x(1:numel(u), :);
    Lambda = zeros(size(F.Aeq, 1), columns);
    Lambda(F.kept, :) = x(numel(u) + 1:end, :);
    Lambda_known = -(F.rows_known * Z + 0.5 * B(F.known, :) + F.Aeq(:, F.known)' * Lambda);
    left_out = setdiff(1:size(F.Aeq, 1), F.kept);
    gap = abs(F.Aeq(left_out, :) * Z - Beq_all(left_out, :));
    if any(gap(:) > 1e-8 * max([1; abs(Z(:)); abs(Beq_all(:))]))
        warning('min_quad_with_fixed:contradiction', ...
                'an equality that follows from others contradicts them in Beq');
    end
end

function F = prepare(A, known, Aeq)
    % The factor of the rows that are not known, with the equalities.
    n = size(A, 1);
    if isempty(Aeq), Aeq = sparse(0, n); end
    if islogical(known), known = find(known); end
    A = sparse(double(A));
    Aeq = sparse(double(Aeq));
    A = (A + A') / 2; % the energy depends on nothing else
    F.n = n;
    F.known = known(:);
    is_known = false(n, 1);
    is_known(F.known) = true;
    F.unknown = find(~is_known);
    F.blank = ~any(Aeq(:, F.unknown), 2); % equalities among known values only
    F.Aeq_blank = Aeq(F.blank, F.known);
    F.Aeq = Aeq(~F.blank, :);
    F.rows_known = A(F.known, :);
    F = with_equalities(F, A, 1:size(F.Aeq, 1));
    try
        F.factor = sparse_local(F.matrix, 'pivoted', F.equalities > 0);
    catch e
        singular = strcmp(e.identifier, 'sparse_local:pivot');
        if ~singular && ~strcmp(e.identifier, 'sparse_local:inaccurate'), rethrow(e); end
        if F.equalities > 0
            F = with_equalities(F, A, independent(F.Aeq(:, F.unknown)));
        end
        F.factor = factor_of_singular(F, e);
    end
end

function F = with_equalities(F, A, kept)
    % The system with these equalities.
    F.kept = kept;
    F.equalities = numel(kept);
    E = F.Aeq(kept, F.unknown);
    F.coupling = [A(F.unknown, F.known); F.Aeq(kept, F.known)];
    F.matrix = [A(F.unknown, F.unknown), E'; E, sparse(F.equalities, F.equalities)];
end

function kept = independent(E)
    % Rows of E that the others do not imply: QR with pivoting, on the columns that have entries.
    E = full(E(:, any(E, 1)));
    sizes = sqrt(sum(E .^ 2, 2));
    [~, R, order] = qr((E ./ sizes)', 0);
    d = abs(diag(R));
    kept = sort(order(1:sum(d > 1e-10 * d(1))));
end

function factor = factor_of_singular(F, e)
    % Semidefinite, or an energy without a minimum that may still have a stationary point.
    ways = {{'null_pivots', 'skip'}, {'pivoted', true}};
    if F.equalities > 0, ways = {{'pivoted', true}}; end
    for k = 1:numel(ways)
        try
            factor = sparse_local(F.matrix, ways{k}{:});
            return
        catch
        end
    end
    in_original_rows(e, F);
end

function in_original_rows(e, F)
    % The error of the factor, with the row of A, or the equality.
    row = regexp(e.message, '\(row (\d+)', 'tokens');
    where = '';
    if ~isempty(row)
        row = str2double(row{1}{1});
        if row <= numel(F.unknown)
            where = sprintf('; this is row %d of A', F.unknown(row));
        else
            where = sprintf('; this is equality %d', F.kept(row - numel(F.unknown)));
        end
    end
    what = 'the system is singular: its solution is not unique, or there is none';
    if strcmp(e.identifier, 'sparse_local:inaccurate')
        what = 'the system is so badly scaled that its factor has no correct digit';
    end
    error(e.identifier, '%s%s', what, where);
end

function M = spread(M, columns)
    % One column for each column of Z.
    if size(M, 2) == 1 && columns > 1, M = repmat(M, 1, columns); end
end
